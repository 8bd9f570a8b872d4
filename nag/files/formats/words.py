"""Words of other programs that are no names of variables there.

Each word of a program was tried as the only variable of a ring, in whose ideal it occurs:
Macaulay2 1.21 with all words of its dictionaries, Singular 4.3.1 with those of ``reservedName()``,
the procedures that it begins with, the words in its library, and names of two characters. These
are the ones that were refused. Those of the other programs are from their grammars: of Bertini the
declarations, functions and numbers of Bertini 1 and 2, of Julia its keywords and what a module is
born with, of Python its keywords; besides, what a written file uses itself.
"""

from __future__ import annotations

from keyword import kwlist

# A word of Macaulay2 with an index, as in ``ring_1``, is refused as well.
MACAULAY2 = frozenset(
    """
about abs accumulate Acknowledgement acos acosh acot acoth addCancelTask addDependencyTask
addEndFunction addHook AdditionalPaths addStartFunction addStartTask Adjacent adjoint AffineVariety
AfterEval AfterNoPrint AfterPrint agm alarm Algorithm Alignment all AllCodimensions
allowableThreads ambient analyticSpread ancestor ancestors and AngleBarList ann annihilator
antipode any append applicationDirectory applicationDirectorySuffix apply applyKeys applyPairs
applyTable applyValues apropos argument Array arXiv Ascending ascii asin asinh ass assert
associatedGradedRing associatedPrimes AssociativeExpression atan atan2 atanh atEndOfFile Authors
autoload AuxiliaryFiles backtrace Bag Bareiss baseFilename BaseFunction baseName baseRing baseRings
BaseRow BasicList basis BasisElementLimit Bayer BeforePrint beginDocumentation benchmark BesselJ
BesselY Beta betti BettiTally between Binary BinaryOperation Binomial binomial BKZ blockMatrixForm
Body Boolean borel Boxes break cache CacheExampleOutput CacheFunction CacheTable cacheValue
CallLimit cancelTask capture CatalanConstant catch Caveat CC ceiling Center centerString
Certification ChainComplex chainComplex ChainComplexMap changeBase ChangeMatrix char characters
check checkDegrees CheckDocumentation chi class clean clearAll clearEcho clearOutput close closeIn
closeOut ClosestFit code codim CodimensionLimit coefficient CoefficientRing coefficientRing
coefficients Cofactor CohenEngine CohenTopLevel CoherentSheaf cohomology coimage coker cokernel
collectGarbage columnAdd columnate columnMult columnPermute columnRankProfile columnSwap combine
Command commandInterpreter commandLine commonest commonRing comodule compactMatrixForm
CompiledFunction CompiledFunctionBody CompiledFunctionClosure Complement complement complete
CompleteIntersection ComplexField components compose compositions compress concatenate conductor
ConductorElement cone Configuration conjugate connectionCount Consequences Constant Constants
content continue contract Contributors conwayPolynomial copy copyDirectory copyFile copyright cos
cosh cot cotangentSheaf coth cover coverMap cpuTime createTask csc csch current currentColumnNumber
currentDirectory currentFileDirectory currentFileName currentLayout currentPackage currentPosition
currentRowNumber currentTime Database Date dd debug debugError DebuggingMode debuggingMode
debugLevel Decompose decompose deepSplice Default default defaultPrecision Degree degree
DegreeGroup degreeGroup degreeLength DegreeLift DegreeLimit DegreeMap DegreeOrder DegreeRank
Degrees degrees degreesMonoid degreesRing delete demark denominator Dense Density depth Descending
Descent Describe describe Description det determinant diagonalMatrix diameter Dictionary dictionary
dictionaryPath diff difference Digamma dim directSum disassemble discriminant dismiss Dispatch
distinguished Divide divideByVariable DivideConquer DividedPowers do doc docExample docTemplate
document DocumentTag Down drop dual Dynamic eagonNorthcott echoOff echoOn edit eigenvalues
eigenvectors eint EisenbudHunekeVasconcelos elapsedTime elapsedTiming elements Eliminate eliminate
else Email End end endl endPackage Engine engineDebugLevel EngineRing entries environment Equation
erase erf erfc error errorDepth euler EulerConstant eulers even EXAMPLE ExampleFiles examples
Exclude exec exit exp expectedReesIdeal expm1 exponents export exportFrom exportMutable Expression
expression Ext extend exteriorPower factor false Fano FastNonminimal File fileDictionaries
fileExecutable fileExists fileExitHooks fileLength fileMode FileName FilePosition fileReadable
fileTime fileWritable fillMatrix findFiles findHeft FindOne findProgram findSynonyms First first
firstkey fittingIdeal flagLookup FlatMonoid flatten flattenRing Flexible flip floor flush fold
FollowLinks for forceGB fork Format format formation fpLLL frac fraction FractionField frames from
fromDividedPowers fromDual Function FunctionApplication FunctionBody functionBody FunctionClosure
GaloisField Gamma gb GBDegrees gbRemove gbSnapshot gbTrace gcd gcdCoefficients gcdLLL GCstats
genera GeneralOrderedMonoid GenerateAssertions generateAssertions generator generators Generic
genericMatrix genericSkewMatrix genericSymmetricMatrix gens genus get getc getChangeMatrix getenv
getGlobalSymbol getNetFile getNonUnit getPrimeWithRootOfUnity getSymbol getWWW GF Givens GLex
Global global globalAssign globalAssignFunction GlobalAssignHook globalAssignment
globalAssignmentHooks GlobalDictionary GlobalHookStore globalReleaseFunction GlobalReleaseHook
Gorenstein GradedModule gradedModule GradedModuleMap gradedModuleMap gramm graphIdeal graphRing
Grassmannian GRevLex GroebnerBasis groebnerBasis GroebnerBasisOptions groupID GroupLex GroupRevLex
GTZ handleInterrupts HardDegreeLimit hash HashTable hashTable HeaderType Heading Headline Heft heft
Height height help Hermite hermite Hermitian HH hh Hilbert hilbertFunction hilbertPolynomial
hilbertSeries hold Holder Hom homeDirectory HomePage Homogeneous Homogeneous2 homogenize homology
homomorphism hooks horizontalJoin HorizontalSpace html httpHeaders Hybrid hypertext icFracP
icFractions icMap icPIdeal id Ideal ideal idealizer identity if IgnoreExampleErrors ii image
imaginaryPart ImmutableType importFrom in incomparable Increment independentSets indeterminate
IndeterminateNumber Index index indexComponents IndexedVariable IndexedVariableTable indices
inducedMap inducesWellDefinedMap InexactField InexactFieldFamily InexactNumber InfiniteNumber
infinity info InfoDirSection infoHelp Inhomogeneous input Inputs insert installAssignmentMethod
installedPackages installHilbertFunction installMethod installMinprimes installPackage
InstallPrefix instance instances integralClosure integrate interpreterDepth intersect intersectInP
Intersection intersection interval inverse inverseErf InverseMethod inversePermutation
inverseRegularizedBeta inverseRegularizedGamma Inverses inverseSystem Invertible
irreducibleCharacteristicSeries irreducibleDecomposition isAffineRing isANumber isBorel isc
isCanceled isCommutative isConstant isDirectory isDirectSum isEmpty isField isFinite
isFinitePrimeField isFreeModule isGlobalSymbol isHomogeneous isIdeal isInfinite isInjective
isInputFile isIsomorphic isIsomorphism isLinearType isListener isLLL isMember isModule
isMonomialIdeal isNormal isOpen isOutputFile isPolynomialRing isPrimary isPrime isPrimitive
isPseudoprime isQuotientModule isQuotientOf isQuotientRing isReady isReal isReduction isRegularFile
isRing isSkewCommutative isSorted isSquareFree isStandardGradedPolynomialRing isSubmodule
isSubquotient isSubset isSupportedInZeroLocus isSurjective isTable isUnit isWellDefined
isWeylAlgebra Iterate Iterator iterator Jacobian jacobian jacobianDual Join join Jupyter Keep
KeepFiles KeepZeroes ker kernel kernelLLL kernelOfLocalization Key keys Keyword Keywords kill
koszul last lastMatch Layout lcm leadCoefficient leadComponent leadMonomial leadTerm Left left
length LengthLimit Lex lift liftable Limit limitFiles limitProcesses Linear LinearAlgebra
lineNumber lines linkFile List list listForm listLocalSymbols listSymbols listUserSymbols LLL
lngamma load loadDepth LoadDocumentation loadedFiles loadedPackages loadPackage Local local
localDictionaries LocalDictionary localize locate log log1p LongPolynomial lookup lookupCount
LowerBound LUdecomposition makeDirectory MakeDocumentation makeDocumentTag MakeHTML MakeInfo
MakeLinks makePackageIndex MakePDF makeS2 Manipulator map MapExpression markedGB match mathML
Matrix matrix MatrixExpression max maxAllowableThreads maxExponent MaximalRank maxPosition
MaxReductionCount member memoize memoizeClear memoizeValues merge mergePairs method MethodFunction
MethodFunctionBinary MethodFunctionSingle MethodFunctionWithOptions methodOptions methods midpoint
min minExponent mingens mingle minimalBetti MinimalGenerators MinimalMatrix minimalPresentation
minimalPresentationMap minimalPresentationMapInv minimalPrimes minimalReduction Minimize
minimizeFilename MinimumVersion minors minPosition minPres minprimes Minus minus mkdir mod Module
module modulo Monoid monoid MonoidElement Monomial monomialCurveIdeal MonomialIdeal monomialIdeal
MonomialOrder Monomials monomials MonomialSize monomialSubideal moveFile multidegree multidoc
multigraded MultigradedBettiTally multiplicity mutable MutableHashTable mutableIdentity MutableList
MutableMatrix mutableMatrix Name nanosleep NCLex needs needsPackage Net net NetFile netList new
newClass newCoordinateSystem NewFromMethod newline NewMethod newNetFile NewOfFromMethod NewOfMethod
newPackage newRing next nextkey nextPrime NonAssociativeProduct NoPrint norm normalCone not Nothing
notify notImplemented NTL null nullaryMethods nullhomotopy nullSpace Number number
NumberedVerticalList numcols numColumns numerator numeric numericInterval numgens numRows numrows
odd oeis of ofClass on OneExpression OO openDatabase openDatabaseOut openFiles openIn openInOut
openListener openOut openOutAppend operatorAttributes Option OptionalComponentsPresent Options
options OptionTable or Order order OrderedMonoid Outputs override pack Package package
PackageDictionary PackageExports PackageImports packageTemplate pad pager PairLimit pairs
PairsRemaining parent Parenthesize part Partition partition partitions parts path pdim peek
permanents permutations pfaffians pi pivots PlaneCurveSingularities plus poincare poincareN
polarize poly PolynomialRing Position position positions POSIX Postfix Power power powermod
Precision precision Prefix prefixDirectory prefixPath preimage prepend presentation pretty
primaryComponent primaryDecomposition PrimaryTag PrimitiveElement Print print printerr
printingAccuracy printingLeadLimit printingPrecision printingSeparator printingTimeLimit
printingTrailLimit printString printWidth processID Product product ProductOrder profile
profileSummary Program programPaths ProgramRun Proj Projective ProjectiveHilbertPolynomial
projectiveHilbertPolynomial ProjectiveVariety promote protect Prune prune pruningMap Pseudocode
pseudocode pseudoRemainder pushForward QQ QRDecomposition quit Quotient quotient quotientRemainder
QuotientRing Radical radical RadicalCodim1 radicalContainment RaiseError random
randomKRationalPoint randomMutableMatrix Range rank read readDirectory readlink readPackage
RealField RealFP realPart realpath RealQP RealQP1 RealRR RealXD recursionDepth recursionLimit
Reduce reducedRowEchelonForm reduceHilbert reductionNumber reesAlgebra reesAlgebraIdeal reesIdeal
References regex regexQuote registerFinalizer regSeqInIdeal regularity regularizedBeta
regularizedGamma relations relativizeFilename Reload remainder RemakeAllDocumentation remove
removeDirectory removeFile removeLowestDimension reorganize replace RerunExamples res reshape
Resolution resolution restart Result resultant return returnCode Reverse reverse RevLex Right right
Ring ring RingElement RingFamily ringFromFractions RingMap rootPath roots rootURI rotate round
rowAdd RowExpression rowMult rowPermute rowRankProfile rowSwap RR RRi rsort run RunDirectory
RunExamples runHooks runLengthEncode runProgram same saturate scan scanKeys scanLines scanPairs
scanValues schedule schreyerOrder Schubert scriptCommandLine ScriptedFunctor searchPath sec sech
SeeAlso seeParsing select selectInSubring selectVariables SelfInitializingType separate
SeparateExec separateRegexp Sequence sequence serialNumber Set set setEcho setGroupID
setIOExclusive setIOSynchronized setIOUnSynchronized setRandomSeed setup setupEmacs sheaf
SheafExpression sheafExt sheafHom SheafOfRings shield ShimoyamaYokoyama show showClassStructure
showHtml showStructure showTex showUserStructure simpleDocFrob SimplifyFractions sin singularLocus
sinh size size2 SizeLimit SkewCommutative sleep smithNormalForm solve someTerms Sort sort
sortColumns SortStrategy source SourceCode SourceRing SPACE span SparseMonomialVectorExpression
SparseVectorExpression Spec specialFiber specialFiberIdeal splice splitWWW sqrt stack stacksProject
Standard standardForm standardPairs StartWithOneMinor stashValue status stderr stdio step
StopBeforeComputation stopIfError StopIteration StopWithMinimalGenerators Strategy Strict String
sub sublists submatrix submatrixByDegrees Subnodes subquotient SubringLimit Subscript subscript
subsets substitute substring subtable Sugarless Sum sum SumOfTwists super Superscript superscript
support SVD switch sylvesterMatrix Symbol symbol SymbolBody symbolBody symlinkDirectory symlinkFile
symmetricAlgebra symmetricAlgebraIdeal symmetricKernel symmetricPower synonym SYNOPSIS syz Syzygies
SyzygyLimit SyzygyMatrix SyzygyRows syzygyScheme Table table take Tally tally tan tangentCone
tangentSheaf tanh target Task taskResult temporaryFileName tensor tensorAssociativity terms TEST
Test testExample testHunekeQuestion TestInput tests tex TeXmacs texMath then Thing threadVariable
Threshold throw Time time times timing to toAbsolutePath toCC toDividedPowers toDual
toExternalString toField toList toLower top topCoefficients topComponents topLevelMode Tor Toric
toRR toRRi Torsion toSequence toString TotalPairs toUpper trace transpose Tries Trim trim true
Truncate truncate truncateOutput try tutorial Type TypicalValue typicalValues ultimate unbag
uncurry Undo undocumented uniform uninstallAllPackages uninstallPackage Unique unique
uniquePermutations Unmixed unsequence unstack Up UpdateOnly UpperTriangular URL urlEncode Usage use
UseCachedExampleOutput UseHilbertFunction UserMode userSymbols UseSyzygies utf8 utf8check
utf8substring value values Variable VariableBaseName Variables Variety variety vars Vasconcelos
Vector vector VectorExpression Verbose Verbosity Verify versalEmbedding Version version
VerticalList VerticalSpace viewHelp VirtualTally VisibleList wait WebApp wedgeProduct weightRange
Weights WeylAlgebra when whichGm while width wikipedia Wrap wrap WrapperType xor youngest zero
ZeroExpression zeta ZZ
""".split()  # noqa: SIM905
)

SINGULAR = frozenset(
    """
alias align and apply ASSUME attrib bareiss basering betti bigint bigintmat bracket branchTo break
breakpoint char charstr chinrem cleardenom close coef coeffs continue contract convhull cring
crossprod Current datetime dbprint def defined deg degBound degree delete denominator det diff dim
div division dump echo eliminate else envelope ERROR eval example execute exit export exportto
extgcd facstd factmodd factorize farey fetch fglm fglmquot find finduni Float for forif fprintf
freemodule fres frwalk GCD gcd gen getdump groebner help highcorner hilb hilbRing homog hres ideal
if imap impart importfrom IN indepSet insert int interpolation interred intersect intmat intvec
jacob janet jet kbase keepring kernel kill killattrib koszul kres laguerre lead leadcoef leadexp
leadmonom LIB lift liftstd link list listvar load lres ludecomp luinverse lusolve map matrix max
maxideal memory min minbase minor minpoly minres mod module modulo monitor monomial mpresmat mres
mstd mult multBound multiplicity nagideal nagring nameof names ncalgebra ncols newline newstruct NF
noether not npars nres nrows number numerator nvars open oppose opposite option or ord ordstr
package pagewidth par par2varRing parameter pardeg parstr pause poly polyBucket preimage prime
primefactors print printf printlevel proc prune pyobject qhweight QQ qrds qring qslimgb quit quot
quote quotient quotient1 quotient2 quotient3 quotient4 quotient5 quotientList random rank read
reduce regularity repart res reservedName reservedNameList resolution restart resultant RETURN
return rightstd ring ringlist rtimer rvar sba setring short simplex simplify size slimgb smatrix
sortvec sprintf sqrfree sres Standard status std stdfglm stdhilb string subst system syz tensor test
timer Top TRACE trace transpose twostd type typeof univariate uressolve vandermonde var variables
varstr vdim vector verbose voice waitall waitfirst wedge weight weightKB while whileif write ZZ
""".split()  # noqa: SIM905
)

BERTINI = frozenset(
    """
CONFIG E END I INPUT Pi acos arccos arcsin arctan asin atan constant cos definedSubfunction e exp
function hom_variable_group i implicit_parameter log parameter pathvariable pi pow random
random_real sin sqrt subfunction tan variable variable_group
""".split()  # noqa: SIM905
)

JULIA = frozenset(
    """
Base Core HomotopyContinuation Main System baremodule begin break catch ccall const continue cos do
else elseif end eval export false finally for function global if im import in include isa let local
macro module pi quote return sin sqrt struct true try using where while
""".split()  # noqa: SIM905
)

SYMPY = frozenset(
    {*kwlist, "I", "Rational", "S", "Symbol", "cos", "equations", "pi", "sin", "sqrt"}
)
